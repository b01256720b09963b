// Made from src/shapewright/studio/wire/*.py by `python tools/message_types.py`.
export type * from "./values";
export type * from "./problems";
export type * from "./judgement";
export type * from "./collection";
export type * from "./work";
export type * from "./revisions";
export type * from "./detail";
export type * from "./answers";
export type * from "./changes";
export type * from "./requests";
