"""waiter_cli/answersets"""
