"""waiter_cli/layout_tools"""
