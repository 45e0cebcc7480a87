#!/bin/sh
# count.sh BUILD   The last line of `make check`: what was tested, proved and compared.
tests=$(cat "$1"/tests/*.log | sed -n 's/.*Checks: \([0-9]*\).*/\1/p' | awk '{ n += $1 } END { print n + 0 }')
proofs=$(ls "$1"/verify/*.ok | wc -l)
code=$(cat README.md chapters/*.md | grep -c '^<!-- excerpt:')
numbers=$(cat README.md chapters/*.md | sed -n '/^ *<!-- from$/,/-->/p' | grep -c ' [=<>] ')
echo "all is well: $tests tests passed, $proofs proof scripts hold, $code quotes of code and $numbers of numbers are as their sources"
