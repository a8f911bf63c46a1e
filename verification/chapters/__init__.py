"""The chapters of the report; each module has `chapter(run)`, which computes and describes."""
