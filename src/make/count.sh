#!/bin/sh
# count.sh BUILD   The last line of `make check`: what was tested, proved and compared.
# A build folder may also hold what a test or proof left that is no more: not counted.
tests=$(ls tests/*/test_*.c | sed "s|.*/|$1/tests/|; s|c$|log|" | xargs cat |
    sed -n 's/.*Checks: \([0-9]*\).*/\1/p' | awk '{ n += $1 } END { print n + 0 }')
proofs=$(ls verify/*/*.py | sed "s|.*/|$1/verify/|; s|py$|ok|" | xargs ls 2>/dev/null | wc -l)
code=$(cat README.md $(find chapters -name '*.md') | grep -c '^ *<!-- excerpt:')
numbers=$(cat README.md $(find chapters -name '*.md') | sed -n '/^ *<!-- from$/,/-->/p' | grep -c ' [=<>] ')
echo "all is well: $tests tests passed, $proofs proof scripts hold, $code quotes of code and $numbers of numbers are as their sources"
