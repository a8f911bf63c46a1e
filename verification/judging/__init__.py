"""The monitor's verdicts judged: published accidents, and a synthetic fleet with known truth."""
