// What each method does with a late measurement, in a phrase.

export const METHOD_WORDS = {
  standard: "the reference: no measurement is late",
  recalculate: "goes back to the step of the measurement, updates, and propagates again",
  larsen: "carries the correction to the present by the transition matrices: one update, in one step",
  "dual-rate": "spreads covariance and update over the steps until it lands",
  clone: "keeps a copy of what was measured, and its covariance with the present",
  "clone-split": "as clone, its work spread over the steps of measurement and arrival",
  "carried-gain": "updates the covariance when the measurement is taken, and carries the gain",
  "delayed-horizon": "updates in the past and replays the state to the present; covariances follow behind",
  "px4-predictor": "PX4's: a filter behind the present, and an output that follows it; approximate",
  augmentation: "estimates past states beside the present one",
  "fuse-as-fresh": "takes a late measurement for a new one: wrong, to compare with",
};
