"""Whether what a case holds can be meant: ranges, values beside each other, signs, and how it is said."""
