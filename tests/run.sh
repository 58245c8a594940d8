#!/bin/sh
# run.sh - runs test programs and scripts, as many at a time as there are processors, and adds up their Unity summaries.
#
#	run.sh PROGRAM-OR-SCRIPT ...
#
# The last line is "N passed, N failed[, N skipped]"; the exit status is 0 when none failed. A program that crashes or
# prints no summary counts as one failure. LOBE_TEST_JOBS sets how many run at a time.
set -u
logs=build/tests/logs

# one TEST: its line, and its counts in $logs/NAME.count.
one() {
	name=$(basename "$1")
	log=$logs/$name.log
	before=$(date +%s)
	case $1 in
	*.sh) sh "$1" >"$log" 2>&1 ;;
	*) "./$1" >"$log" 2>&1 ;;
	esac
	status=$?
	seconds=$(($(date +%s) - before))
	summary=$(grep -E '^[0-9]+ Tests [0-9]+ Failures [0-9]+ Ignored' "$log" | tail -n 1)
	if [ -n "$summary" ]; then
		# shellcheck disable=SC2086
		set -- $summary
		p=$(($1 - $3 - $5)) f=$3 s=$5
		[ "$f" -gt 0 ] || [ "$status" = 0 ] || f=1
		[ "$1" -gt 0 ] || f=1
	else
		p=0 f=1 s=0
	fi
	echo "$p $f $s" >"$logs/$name.count"
	# One write, so that lines of tests that end together do not mix.
	{
		printf '[%2d/%d] %-28s %4d passed %3d failed %3d skipped %5d s\n' \
			"$(ls "$logs" | grep -c '\.count$')" "$LOBE_TEST_COUNT" "$name" $p $f $s $seconds
		grep -E ':(FAIL|IGNORE)' "$log" | sed 's/^/        /'
		if [ $f -gt 0 ] && ! grep -q ':FAIL' "$log"; then
			echo "        exit status $status; the end of $log:"
			tail -n 15 "$log" | sed 's/^/        /'
		fi
	} >"$logs/$name.line"
	cat "$logs/$name.line"
}

if [ "${1:-}" = --one ]; then
	one "$2"
	exit 0
fi

mkdir -p "$logs"
rm -f "$logs"/*.count
LOBE_TEST_COUNT=$#
export LOBE_TEST_COUNT
started=$(date +%s)
printf '%s\n' "$@" | xargs -P "${LOBE_TEST_JOBS:-$(nproc 2>/dev/null || echo 2)}" -n 1 sh tests/run.sh --one
passed=0 failed=0 skipped=0
for test in "$@"; do
	p=0 f=1 s=0
	! [ -f "$logs/$(basename "$test").count" ] || read -r p f s <"$logs/$(basename "$test").count"
	passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
done
echo "all of it took $(($(date +%s) - started)) s; logs are in $logs"
if [ $skipped -gt 0 ]; then
	echo "$passed passed, $failed failed, $skipped skipped"
else
	echo "$passed passed, $failed failed"
fi
[ $failed = 0 ]
