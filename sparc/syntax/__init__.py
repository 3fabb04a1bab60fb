"""sparc/syntax"""
