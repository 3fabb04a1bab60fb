"""Acts on plans: a belief, an agenda, and an executive that plans again."""
