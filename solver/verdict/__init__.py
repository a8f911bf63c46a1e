"""The verdict: allowables, margins, hot spots, reasons."""
