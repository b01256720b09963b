// Made from src/shapewright/settings.py by `python tools/message_types.py`.

export const PRESETS = ["fast", "paper"] as const;
export const SETTINGS = {
  shape_seconds: { help: "Seconds that building one shape may take.", least: 0, most: null, step: "any" },
  samples: { help: "Parameter vectors to learn from.", least: 20, most: null, step: 1 },
  epochs: { help: "Passes of training over the samples.", least: 1, most: null, step: 1 },
  rounds: { help: "Rounds of more samples around the parameters found so far.", least: 0, most: null, step: 1 },
  refine: { help: "How long to search from the prediction.", choices: ["off", "quick", "thorough"] },
  threshold: { help: "Largest light-field distance of a compatible mesh.", least: 0, most: null, step: "any" },
  vif: { help: "Least visual information fidelity of a compatible drawing.", least: 0, most: 1, step: "any" },
  seed: { help: "Of everything random: the same seed gives the same result.", least: 0, most: null, step: 1 },
} as const;
