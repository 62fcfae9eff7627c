"""The fixtures, one file a maker."""

pytest_plugins = ["performax", "trinamic"]
