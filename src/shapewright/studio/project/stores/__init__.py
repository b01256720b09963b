"""What the page gets again and again, kept on disk."""
