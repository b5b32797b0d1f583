"""What ./ballpit does for students and authors. Python's standard library only."""
