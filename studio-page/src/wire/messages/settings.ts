// Made from src/shapewright/settings.py by `python tools/message_types.py`.

export const PRESETS = ["fast", "paper"] as const;
export const SETTINGS = {
  drop: { help: "What is no part of a shape: sure, ground, backdrop, frustum, loose, or nothing." },
  leave_out: { help: "References that are not fitted: names or patterns, with commas between." },
  shape_seconds: { help: "Seconds that building one shape may take.", least: 0, most: null, step: "any", usual: 10.0 },
  samples: { help: "Parameter vectors to learn from.", least: 20, most: null, step: 1, usual: 3000 },
  epochs: { help: "Passes of training over the samples.", least: 1, most: null, step: 1, usual: 15 },
  rounds: { help: "Rounds of more samples around the parameters found so far.", least: 0, most: null, step: 1, usual: 0 },
  facing: { help: "found turns each reference by the quarter turns that fit best.", choices: ["given", "found"] },
  refine: { help: "How long to search from the prediction.", choices: ["off", "quick", "thorough"] },
  judge: { help: "fidelity: as a person sees it; paper: by light-field distance or VIF.", choices: ["fidelity", "paper"] },
  replicated: { help: "Least fidelity of a replicated reference.", least: 0, most: 1, step: "any", usual: 0.65 },
  close: { help: "Least fidelity of a close one; at most replicated.", least: 0, most: 1, step: "any", usual: 0.35 },
  threshold: { help: "Largest light-field distance of a compatible mesh.", least: 0, most: null, step: "any", usual: 0.18 },
  vif: { help: "Least visual information fidelity of a compatible drawing.", least: 0, most: 1, step: "any", usual: 0.05 },
  seed: { help: "Of everything random: the same seed gives the same result.", least: 0, most: null, step: 1, usual: 0 },
} as const;
export const MEASURES: Record<string, string> = {
  distance: "The paper's: light-field distance, or 1 - VIF; of a scan that of its points",
  iou: "IoU of silhouettes, or of areas",
  chamfer: "Chamfer distance, in largest extents",
  depth: "Difference of depth pictures, 0 to 1",
  fidelity: "Fidelity: how likely a person calls the two the same",
  volume_iou: "IoU of volumes",
  f1: "F-score at 1 % of the largest extent",
  f2: "F-score at 2 % of the largest extent",
};
