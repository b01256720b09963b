"""The Python of docs/generators.md that needs no extra; the rest is in tests/adapters."""

import pytest

from doc_snippets import build_all, library_of, snippets

PAGE = snippets("generators.md")


@pytest.mark.parametrize("text", [text for text in PAGE if library_of(text) is None])
def test_a_block_of_the_page_builds_shapes(text, tmp_path):
    build_all(text, tmp_path)


def test_the_page_has_blocks_with_and_without_a_library():
    assert len({library_of(text) for text in PAGE}) > 1
