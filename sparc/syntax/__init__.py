"""Text ⇄ tree: tokens, the parser with its recovery, the printer and the one style."""
