"""One thing about a reference or a shape: what it is, how it looks, or its surface."""

from __future__ import annotations

from dataclasses import replace

from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import ReferenceShape
from shapewright.studio.bench import messages, shape_messages
from shapewright.studio.bench.gallery import Gallery
from shapewright.studio.bench.workshop import Workshop
from shapewright.studio.project.stores.shape_store import keep_message
from shapewright.studio.wire.answers import DrawingMessage
from shapewright.studio.wire.detail import About


def fetched(
    request: messages.Fetch, references: Gallery, workshop: Workshop
) -> tuple[About | DrawingMessage | None, bytes]:
    """A message, and a payload. Raises KeyError, UnreadableError, ValueError or Broken where there is no such thing."""
    slug = request.slug or ""
    if request.what == "render":
        camera = replace(THUMBNAIL, azimuth=request.azimuth, elevation=request.elevation)
        return None, thumbnail(_pictured(request, references, workshop), request.size, camera)
    reference = references[slug]
    if request.what == "about":
        return shape_messages.about(reference), b""
    message, payload = shape_messages.reference_message(reference.shape, slug)
    keep_message(references.kept_shape(slug), payload)
    return message, payload


def _pictured(request: messages.Fetch, references: Gallery, workshop: Workshop) -> ReferenceShape:
    if request.parameters is None:
        return references[request.slug or ""].shape
    built = workshop.build(request.parameters, request.beyond, slug=request.slug) if workshop.open else None
    if built is None or built.build.shape is None:
        raise ValueError("there is no replica")
    return built.build.shape
