"""The error reported to the user if the report cannot be drawn."""


class ReportError(Exception):
    """Its text is one line that names the file and the cause."""
