"""Answer sets for people: listed, put in the order of time, filtered and written."""
