"""Files of points: what scanners, samplers and reconstructions write, without faces."""
