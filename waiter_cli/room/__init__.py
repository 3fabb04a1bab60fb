"""waiter_cli/room"""
