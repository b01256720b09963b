"""Which way shapes stand: up and front, found from what they look like and from what a procedure makes."""
