"""Library of the scripts: loading, units, tables, fits, style, captions."""
