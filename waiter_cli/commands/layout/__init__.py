"""waiter_cli/commands/layout"""
