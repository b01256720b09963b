"""The types of the messages in TypeScript, for the page: ``python tools/message_types.py``.

Each module of messages becomes a module of ``studio-page/src/wire/messages``. What settings may be is a module too.
"""

from __future__ import annotations

import inspect
import json
import re
import sys
import types
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, NotRequired, Union, get_args, get_origin, get_type_hints, is_typeddict

import msgspec

from shapewright.judging.target import Measures
from shapewright.settings import Preset, Settings, described
from shapewright.studio.wire import (
    answers,
    changes,
    collection,
    detail,
    judgement,
    problems,
    requests,
    revisions,
    values,
    work,
)

MODULES = (values, problems, judgement, collection, work, revisions, detail, answers, changes, requests)
_PLAIN: Mapping[Any, str] = {
    str: "string",
    int: "number",
    float: "number",
    bool: "boolean",
    type(None): "null",
    Any: "unknown",
}
_HEAD = "// Made from src/shapewright/studio/wire/{}.py by `python tools/message_types.py`.\n"


def modules() -> dict[str, str]:
    """The text of each module by the name of its file, and an index of all."""
    homes = {name: _stem(module) for module in MODULES for name in _declared(module)}
    texts = {f"{_stem(module)}.ts": _module(module, homes) for module in MODULES}
    index = "".join(f'export type * from "./{_stem(module)}";\n' for module in MODULES)
    return {**texts, "settings.ts": _settings(), "index.ts": _HEAD.format("*") + index}


def _settings() -> str:
    """What the settings that the page shows are, and what they may be; and what each measure is."""
    lines = [f"\nexport const PRESETS = {json.dumps(get_args(Preset))} as const;", "export const SETTINGS = {"]
    for name, field in described().items():
        if name not in changes.ChosenSettings.__struct_fields__:
            continue
        known: dict[str, Any] = {"help": field.help, "choices": field.choices}
        if field.kind is str and not field.choices:
            known = {"help": field.help}
        elif not field.choices:
            least = field.within.above if field.within.least is None else field.within.least
            known = {"help": field.help, "least": least, "most": field.within.most or field.within.below}
            known["step"] = field.within.step or 1 if field.kind is int else "any"
            known["usual"] = getattr(Settings, name)
        lines.append(f"  {name}: {{ {', '.join(f'{key}: {json.dumps(value)}' for key, value in known.items())} }},")
    lines += ["} as const;", "export const MEASURES: Record<string, string> = {"]
    lines += [f"  {name}: {json.dumps(words)}," for name, words in Measures.words().items()]
    return _HEAD.replace("studio/wire/{}", "settings") + "\n".join([*lines, "};", ""])


def _stem(module: types.ModuleType) -> str:
    return module.__name__.rpartition(".")[2]


def _module(module: types.ModuleType, homes: Mapping[str, str]) -> str:
    home = _stem(module)
    bodies = "".join(f"\n{_alias(n, d) if _title(d) else _interface(n, d)}" for n, d in _declared(module).items())
    used = set(re.findall(r"\b[A-Z]\w+", re.sub(r"/\*\*.*?\*/", "", bodies, flags=re.S)))
    others: dict[str, list[str]] = {}
    for word in sorted(used):
        if homes.get(word, home) != home:
            others.setdefault(homes[word], []).append(word)
    imports = "".join(f'import type {{ {", ".join(words)} }} from "./{other}";\n' for other, words in others.items())
    return _HEAD.format(home) + ("\n" + imports if imports else "") + bodies


def _declared(module: types.ModuleType) -> dict[str, Any]:
    """Its messages and named types, in order."""
    everything = list(vars(module).items())
    return {name: value for name, value in everything if _is_message(value, module) or _is_named(name, module)}


def _is_named(name: str, module: types.ModuleType) -> bool:
    return name in module.__annotations__ and _title(vars(module)[name]) is not None


def _is_message(value: Any, module: types.ModuleType) -> bool:
    """Whether this is a message of the module, and not what several messages have in common."""
    whole = is_typeddict(value) or (_is_struct(value) and not value.__subclasses__())
    return whole and value.__module__ == module.__name__


def _is_struct(value: Any) -> bool:
    return isinstance(value, type) and issubclass(value, msgspec.Struct)


def _title(hint: Any) -> str | None:
    """The name of a type that was given one."""
    metas = get_args(hint)[1:] if get_origin(hint) is Annotated else ()
    return next((meta.title for meta in metas if isinstance(meta, msgspec.Meta) and meta.title), None)


def _alias(name: str, hint: Any) -> str:
    return f"export type {name} = {spelled(get_args(hint)[0])};\n"


def _interface(name: str, kind: Any) -> str:
    summary, notes = _documented(kind)
    lines = [f"/** {summary} */", f"export interface {name} {{"]
    config = getattr(kind, "__struct_config__", None)
    if config and config.tag is not None:
        lines.append(f"  {config.tag_field}: {json.dumps(config.tag)};")
    for field, hint in get_type_hints(kind, include_extras=True).items():
        if field in notes:
            lines.append(f"  /** {notes[field]} */")
        optional, plain = _optional(hint)
        optional |= _is_struct(kind) and issubclass(kind, requests.Order) and field in _with_defaults(kind)
        lines.append(f"  {field}{'?' if optional else ''}: {spelled(plain)};")
    return "\n".join([*lines, "}", ""])


def _with_defaults(kind: Any) -> set[str]:
    return {field.name for field in msgspec.structs.fields(kind) if not field.required}


def _documented(kind: Any) -> tuple[str, dict[str, str]]:
    """The docstring, and the comment behind each field."""
    bases = [base for base in reversed(kind.__mro__) if base.__module__.startswith("shapewright.")]
    notes = re.findall(r"^    (\w+): .*  # (.*)$", "".join(map(inspect.getsource, bases)), re.M)
    return " ".join((inspect.getdoc(kind) or "").split()), {field: f"{note.rstrip('.')}." for field, note in notes}


def _optional(hint: Any) -> tuple[bool, Any]:
    """Whether a field may be missing, and its type where it is there."""
    if get_origin(hint) is NotRequired:
        return True, get_args(hint)[0]
    members = get_args(hint) if get_origin(hint) in (Union, types.UnionType) else ()
    if msgspec.UnsetType in members:
        return True, Union[tuple(member for member in members if member is not msgspec.UnsetType)]  # noqa: UP007
    return False, hint


def spelled(hint: Any) -> str:
    """A type in TypeScript."""
    origin, members = get_origin(hint), get_args(hint)
    if hint in _PLAIN:
        return _PLAIN[hint]
    if origin is Annotated:
        return _title(hint) or spelled(members[0])
    if origin is Literal:
        return " | ".join(json.dumps(member) for member in members)
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(spelled(member) for member in members))
    if origin is list or (origin is tuple and members[-1] is ...):
        inner = spelled(members[0])
        return f"({inner})[]" if "|" in inner else f"{inner}[]"
    if origin is tuple:
        return f"[{', '.join(spelled(member) for member in members)}]"
    if origin is dict:
        return f"Record<{spelled(members[0])}, {spelled(members[1])}>"
    if _is_struct(hint) or is_typeddict(hint):
        return str(hint.__name__)
    raise TypeError(f"{hint} has no form in TypeScript")


def write(folder: Path) -> Iterator[Path]:
    """Write all modules into a folder."""
    folder.mkdir(exist_ok=True)
    for name, text in modules().items():
        (folder / name).write_text(text, encoding="utf-8")
        yield folder / name


if __name__ == "__main__":
    for path in write(Path(sys.argv[1] if len(sys.argv) > 1 else "studio-page/src/wire/messages")):
        sys.stdout.write(f"{path}\n")
