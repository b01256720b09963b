"""A split grammar: rules divide a box into boxes until no tag has a rule left, and the boxes become a shape."""

from shapewright.modelling.grammar.derivation import (
    SIDES,
    Box,
    Derivation,
    Grammar,
    GrammarError,
    Node,
    Rule,
    Side,
    named_by,
    share,
)

__all__ = ["SIDES", "Box", "Derivation", "Grammar", "GrammarError", "Node", "Rule", "Side", "named_by", "share"]
