"""The Python of docs/generators.md with the libraries that it imports."""

import pytest

from doc_snippets import build_all, library_of, snippets

PAGE = [(library, text) for text in snippets("generators.md") if (library := library_of(text))]


@pytest.mark.parametrize(("library", "text"), PAGE)
def test_a_block_of_the_page_builds_shapes_with_its_library(library, text, tmp_path):
    pytest.importorskip(library, reason="needs the extras; run `make test-adapters`")
    build_all(text, tmp_path)
