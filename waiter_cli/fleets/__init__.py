"""Several robots: bounds on the length of their plans, plans by construction, and proofs that there is none."""
