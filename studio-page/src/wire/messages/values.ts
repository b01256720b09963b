// Made from src/shapewright/studio/wire/values.py by `python tools/message_types.py`.

export type Slug = string;

export type Value = number | boolean | string;

export type Values = Record<string, Value>;

export type Vector = [number, number, number];

export type Axis = "x" | "-x" | "y" | "-y" | "z" | "-z";

export type Address = string;
