"""The figures that the platform's requirements ask for (platform.toml), by requirement and name."""
import pathlib
import tomllib

LIMITS = tomllib.loads((pathlib.Path(__file__).resolve().parent / 'platform.toml').read_text(encoding='utf-8'))


def limit(requirement, name):
    return LIMITS[f'LASSO-{requirement}'][name]
