"""Steffes (2014): what it prints, and what it claims, put to the real filters."""
