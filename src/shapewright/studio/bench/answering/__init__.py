"""What the page asks once, and gets one answer to."""
