"""waiter_cli/files"""
