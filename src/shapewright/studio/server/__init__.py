"""The server: routes, security and start."""
