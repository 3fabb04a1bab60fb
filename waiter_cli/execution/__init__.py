"""waiter_cli/execution"""
