"""Draws the report of a sweep of the benchmark: plots by matplotlib, the page by Jinja2."""
