"""The sandbox in the browser: turn xi down and watch."""
