"""Speed, measured as ratios in one run: ours, hand-written C and other libraries take turns."""
