"""Folders of samples: what is drawn, made of each vector, listed; shards of them, and how these are joined."""
