"""Finds a shortest plan and proves that it is one."""
