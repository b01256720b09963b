"""What the author says of many references, and what is known of them together."""
