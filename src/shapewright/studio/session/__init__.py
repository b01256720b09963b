"""What the studio knows and does while it runs."""
