"""Prints the words of the force limits for the page (web: npm run types)."""

from __future__ import annotations

import json

from punctura.live.force_words import CUTS, LIMIT_WORDS

if __name__ == "__main__":
    print(json.dumps({"words": LIMIT_WORDS, "cuts": CUTS}, indent=2))
