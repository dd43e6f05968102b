"""Functions with the names, parameters and definitions of other libraries."""
