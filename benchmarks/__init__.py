"""Speed, measured as ratios in one run: ours and hand-written C take turns."""
