"""waiter_cli/commands/sparc"""
