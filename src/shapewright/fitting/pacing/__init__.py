"""Procedures that build slowly: what a shape costs, how a limit of time is divided, samples that are kept."""
