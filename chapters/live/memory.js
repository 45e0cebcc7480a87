// H 12: a power law as a sum of exponentials; the scene is in modes.js.
FVI_LIVE.modes("memory");
