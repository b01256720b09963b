"""The WebSocket: one conversation with each page."""

from __future__ import annotations

import asyncio

from starlette.websockets import WebSocket, WebSocketDisconnect

from shapewright.studio.session.pages import Page
from shapewright.studio.session.session import Session
from shapewright.studio.wire import requests
from shapewright.studio.wire.changes import WrongMessage


async def converse(session: Session, socket: WebSocket) -> None:
    """Serve one page until it goes."""
    await socket.accept()
    page = session.open_page()

    async def speak() -> None:
        while (message := await page.queue.get()) is not None:
            await (socket.send_bytes(message) if isinstance(message, bytes) else socket.send_text(message))
        await socket.close(1013)

    speaker = asyncio.create_task(speak())
    try:
        while True:
            _hear(session, page, await socket.receive_text())
    except (WebSocketDisconnect, KeyError, RuntimeError):  # it went, sent bytes, or was given up as too slow
        pass
    finally:
        speaker.cancel()
        session.close_page(page)


def _hear(session: Session, page: Page, text: str) -> None:
    try:
        message = requests.decode_page_message(text)
        if isinstance(message, requests.Visible):
            session.bench.put_first(message.slugs)
            return
        requests.check_known([message.slug], session.display.board.references)
        session.bench.evaluate(page.number, message)
    except requests.Wrong as error:
        session.pages.send(page.number, WrongMessage(error=str(error)))
