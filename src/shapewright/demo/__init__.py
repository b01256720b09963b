"""The demo: bundled references and procedures."""
