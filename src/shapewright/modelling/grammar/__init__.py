"""A split grammar: rules divide a box into boxes until no tag has a rule left, and the boxes become a shape."""

from shapewright.modelling.arguments import SIDES, Side
from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.derivation import Derivation
from shapewright.modelling.grammar.divisions import share
from shapewright.modelling.grammar.expansion import GrammarError, Node, Rule
from shapewright.modelling.grammar.grammar import Grammar

__all__ = ["SIDES", "Box", "Derivation", "Grammar", "GrammarError", "Node", "Rule", "Side", "share"]
