#!/bin/sh
# run.sh - runs test programs and scripts one by one and adds up their Unity summaries.
#
#	run.sh PROGRAM-OR-SCRIPT ...
#
# The last line is "N passed, N failed[, N skipped]"; the exit status is 0 when none failed. A program that crashes or
# prints no summary counts as one failure.
set -u
logs=build/tests/logs
mkdir -p "$logs"
passed=0 failed=0 skipped=0
count=$# at=0
started=$(date +%s)
for test in "$@"; do
	at=$((at + 1))
	name=$(basename "$test")
	log=$logs/$name.log
	before=$(date +%s)
	case $test in
	*.sh) sh "$test" >"$log" 2>&1 ;;
	*) "./$test" >"$log" 2>&1 ;;
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
	passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
	printf '[%2d/%d] %-28s %4d passed %3d failed %3d skipped %5d s\n' $at "$count" "$name" $p $f $s $seconds
	grep -E ':(FAIL|IGNORE)' "$log" | sed 's/^/        /'
	if [ $f -gt 0 ] && ! grep -q ':FAIL' "$log"; then
		echo "        exit status $status; the end of $log:"
		tail -n 15 "$log" | sed 's/^/        /'
	fi
done
echo "all of it took $(($(date +%s) - started)) s; logs are in $logs"
if [ $skipped -gt 0 ]; then
	echo "$passed passed, $failed failed, $skipped skipped"
else
	echo "$passed passed, $failed failed"
fi
[ $failed = 0 ]
