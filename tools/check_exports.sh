#!/usr/bin/env bash
# Checks that a shared library exports exactly the functions that punctura.h declares.
#   tools/check_exports.sh LIBRARY
set -euo pipefail
header=$(dirname "${BASH_SOURCE[0]}")/../capi/include/punctura.h
exported() { nm -D --defined-only "$1" | awk '{ print $3 }' | sort; }
declared() {
  tr '\n' ' ' <"$header" | grep -oE 'PUNCTURA_API [^;]*;' | grep -oE 'punctura_[a-z0-9_]+\(' | tr -d '(' | sort
}
diff <(declared) <(exported "$1") || { echo "$1 does not export what $header declares"; exit 1; }
echo "exports: $(declared | wc -l) functions"
