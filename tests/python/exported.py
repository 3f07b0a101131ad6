"""The public classes of punctura."""

import importlib
import inspect
import pkgutil

import punctura


def exported() -> dict[str, type]:
    """Each public class by its module and name."""
    modules = [
        punctura,
        *(importlib.import_module(f"punctura.{m.name}") for m in pkgutil.iter_modules(punctura.__path__)),
    ]
    modules.append(importlib.import_module("punctura.studio.client"))
    return {
        f"{module.__name__}.{name}": thing
        for module in modules
        for name in getattr(module, "__all__", None) or [n for n in vars(module) if n[0] != "_"]
        if inspect.isclass(thing := getattr(module, name)) and thing.__module__.startswith("punctura")
    }
