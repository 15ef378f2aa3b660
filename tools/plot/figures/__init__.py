"""Figures of gnomon's results, studies and spectra: one file a kind of figure."""
