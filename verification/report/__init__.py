"""The report of a run: one document, written as a web page and as a printed one."""

from verification.report.document import Document, build_document
from verification.report.markdown import write_pages
from verification.report.page import write_page
from verification.report.print import write_print

__all__ = ["Document", "build_document", "write_page", "write_pages", "write_print"]
