// Made from src/shapewright/studio/wire/*.py by `python tools/message_types.py`.
export type * from "./values";
export type * from "./problems";
export type * from "./board";
export type * from "./jobs";
export type * from "./runs";
export type * from "./references";
export type * from "./shapes";
export type * from "./changes";
export type * from "./requests";
