"""Figures of gnomon's results, studies and spectra: one file per kind of figure."""
