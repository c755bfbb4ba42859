"""The figures of the paper, in its layout: axes, signs and line styles as its captions describe them."""
