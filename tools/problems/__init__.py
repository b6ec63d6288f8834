"""The problems of docs/validation.md: which decks are run, and what they are compared with."""
