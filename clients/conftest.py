"""The fixtures, one file a maker, and which tests run: firmware images are no server, and a server no image."""

import images

pytest_plugins = ["performax", "trinamic"]

collect_ignore_glob = [] if images.FOLDER else ["test_image*.py"]


def pytest_collection_modifyitems(config, items):
    """Leaves out tests of the server as a program where images take its place."""
    if images.FOLDER:
        out = [item for item in items if item.get_closest_marker("server_only")]
        items[:] = [item for item in items if item not in out]
        config.hook.pytest_deselected(items=out)
