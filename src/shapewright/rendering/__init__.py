"""Rendering: small pictures of shapes, without a GL context."""
