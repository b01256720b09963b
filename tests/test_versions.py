from importlib import metadata

from shapewright import versions


def test_a_package_that_is_not_installed_is_no_reason_to_lose_a_run(monkeypatch):
    monkeypatch.setattr(versions, "VERSIONED", ("numpy", "no-such-package-of-ours"))
    found = versions.versions()
    assert found["numpy"] == metadata.version("numpy") and found["no-such-package-of-ours"] == "unknown"
