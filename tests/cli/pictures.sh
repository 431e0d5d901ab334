#!/bin/sh
# pictures.sh MUSTER ROOT: what is made of runs: figures, a page, a film; and the film of the README.
set -eu

muster=$1
root=$2
check=$root/tests/cli/pictures.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAIL: $*"
    cat out err
    exit 1
}

run() {
    status=0
    "$muster" "$@" >out 2>err </dev/null || status=$?
}

done_by() {
    run "$@"
    [ "$status" -eq 0 ] || fail "$*"
}

# refuses WORDS ARG...: exit status 2, the words on stderr, and no file more.
refuses() {
    words=$1
    shift
    before=$(ls)
    run "$@"
    [ "$status" -eq 2 ] || fail "$* should end with 2, not $status"
    grep -qF -e "$words" err || fail "$* does not say: $words"
    [ "$(ls)" = "$before" ] || fail "$* leaves something"
}

touch out err
for seed in 1 2 3 4 5 6 7 8 9; do
    done_by sim --robots native --quiet --seed $seed --set network.loss=0.2 --set duration=12 \
        --out "lossy/$seed" "$root/scenarios/paper-sim-leader-fault.yaml"
done
done_by sim --robots native --quiet --out fault "$root/scenarios/paper-sim-leader-fault.yaml"

# One page, of one run and of several.
done_by report fault
grep -qF 'fault/report.html' out || fail 'where is it?'
python3 "$check" report fault/report.html fault/summary.json
done_by report --quiet fault lossy/1
[ ! -s out ] || fail '--quiet is not quiet'
python3 "$check" report report.html fault/summary.json
grep -q '<a href="#run-1">fault</a>.*<a href="#run-2">1</a>' report.html || fail 'which run is which?'
done_by report --out many.html lossy/*
grep -q 'their median' many.html || fail 'no median of many runs'
rm report.html many.html

# Figures.
done_by plot fault
for file in plot.svg plot.png; do
    [ -s $file ] || fail "no $file"
done
python3 "$check" svg plot.svg
grep -q 'robot 1 is lost' plot.svg || fail 'no events'
grep -q '^fault .* 30.00 .* 0.0039 .* 2.304 .* 6.36$' out || fail 'other numbers than those of summary.json'
done_by plot --quiet --out 'a b.pdf' fault lossy/1 lossy/2
[ "$(head -c 4 'a b.pdf')" = '%PDF' ] || fail 'no PDF'
[ ! -s out ] || fail '--quiet is not quiet'
rm plot.* 'a b.pdf'

# A film; the same from the recording alone, and nearly so, without a formation, from the CSV.
done_by video fault
python3 "$check" film fault.svg fault/trace.csv
[ "$(wc -c <fault.svg)" -lt 150000 ] || fail 'a large film'
done_by video --out twice.svg fault
cmp -s fault.svg twice.svg || fail 'the same run gives another film'
mkdir csv
cp fault/*.csv csv
done_by video --out csv.svg csv
python3 "$check" film csv.svg fault/trace.csv
grep -q 'class="vertex' fault.svg || fail 'no vertices'
! grep -q 'class="vertex' csv.svg || fail 'vertices out of nothing'
# What drives straight on has two moments, what stands still none.
{
    echo t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive
    for tick in $(seq 0 99); do
        echo "$tick,1,$tick,0,0,1,0,L,1,0,1"
        echo "$tick,2,50,5,1,0,0,F,2,0,1"
    done
} >csv/trace.csv
done_by video --out straight.svg csv
[ "$(grep -c 'type="translate" dur="11.4s" repeatCount="indefinite" keyTimes="0;.8684;1"' straight.svg)" -eq 2 ] ||
    fail 'robot 1 and the line of the time do not go on straight'
! grep -q 'type="rotate"' straight.svg || fail 'somebody turns'
done_by video --from 8 --to 14 --speed 1 --width 500 --out part.svg fault
python3 "$check" svg part.svg
grep -q 'width="500"' part.svg && grep -q 'dur="7.5s"' part.svg || fail 'another part'
cmp "$root/docs/images/leader-fault.svg" fault.svg ||
    fail 'docs/images/leader-fault.svg is an older one; make docs makes it anew'
rm ./*.svg

# A recording that was cut short goes as far as it does.
mkdir torn
head -c 300000 fault/run.mcap >torn/run.mcap
done_by plot --out torn.svg torn
grep -q 'cut short' out || fail 'that it is cut short is not told'
done_by report torn
grep -q 'cut short' torn/report.html || fail 'that it is cut short is not told'
rm torn.svg

mkdir nothing
: >here.html
refuses 'which run?' plot
refuses 'which run?' report
refuses 'which run?' video
refuses 'missing: No such file or directory' plot fault missing
refuses 'nothing: no run is in it, neither run.mcap nor trace.csv' report nothing
refuses 'here.html is no MCAP file' video here.html
refuses 'ends in .svg, .png or .pdf' plot --out plot.jpg fault
refuses 'ends in .svg is allowed' video --out film.mp4 fault
refuses 'one run at a time' video fault torn
refuses '--speed 0: a number from' video --speed 0 fault
refuses '--width 5x: a number from 320' video --width 5x fault
refuses 'nothing to show from 40 s to 30 s' video --from 40 fault
run plot --out nowhere/plot.svg fault
[ "$status" -eq 1 ] || fail 'a figure that cannot be written is a failure'
run video --out nowhere/film.svg fault
[ "$status" -eq 1 ] || fail 'a film that cannot be written is a failure'
run report --out nowhere/page.html fault
[ "$status" -eq 1 ] || fail 'a page that cannot be written is a failure'
