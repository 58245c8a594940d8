#!/bin/sh
# mitsuba.sh - runs mitsuba.py in an environment of its own, build/peers, in which it installs Mitsuba 3 from PyPI and, where
# the system has no LLVM that Mitsuba can use (17 or later; 14 to 16 fail), unpacks Debian's libllvm19 without installing it.
# Where that cannot be done it says why, and that the comparison is skipped; that is no failure.
cd "$(dirname "$0")/../.." || exit 1
peers=build/peers
mkdir -p $peers

skip() {
	echo "bench-peers: skipped: $1"
	exit 0
}

command -v python3 >/dev/null || skip "no python3 here"
if [ ! -x $peers/venv/bin/python ]; then
	python3 -m venv $peers/venv >$peers/venv.log 2>&1 || skip "python3 -m venv failed (Debian: python3-venv); $peers/venv.log"
fi
if ! $peers/venv/bin/python -c 'import mitsuba' 2>/dev/null; then
	echo "bench-peers: installing mitsuba from PyPI into $peers/venv"
	$peers/venv/bin/pip install -q mitsuba >$peers/pip.log 2>&1 || skip "pip cannot install mitsuba; $peers/pip.log"
fi

# The newest libLLVM of a folder that holds one.
newest() { find "$@" -name 'libLLVM*.so*' 2>/dev/null | grep -E 'LLVM(-|\.so\.)(1[7-9]|2[0-9])' | sort -V | tail -n 1; }

if [ -z "$DRJIT_LIBLLVM_PATH" ]; then
	DRJIT_LIBLLVM_PATH=$(newest /usr/lib /usr/local/lib)
	if [ -z "$DRJIT_LIBLLVM_PATH" ] && [ -z "$(newest $peers/llvm)" ]; then
		echo "bench-peers: unpacking Debian's libllvm19 into $peers/llvm"
		(cd $peers && apt-get download libllvm19 && dpkg -x libllvm19_*.deb llvm) >$peers/llvm.log 2>&1 ||
			skip "no libLLVM 17 or later; set DRJIT_LIBLLVM_PATH; $peers/llvm.log"
	fi
	[ -n "$DRJIT_LIBLLVM_PATH" ] || DRJIT_LIBLLVM_PATH=$PWD/$(newest $peers/llvm)
	export DRJIT_LIBLLVM_PATH
fi
exec $peers/venv/bin/python bench/peers/mitsuba.py "$@"
