# rain_refused-01.sh PROGRAM SOURCE FOLDER NUMDIFF
# Rain that is negative at a later time would draw water out of the soil: refused before
# anything is written.
rm -rf "$3"
mkdir -p "$3"
cd "$3"
for rain in '-1e-6*t' '1e-9*(1 - t/5e5)'; do
  if "$1" "$2/tests/seepage/hydrostatic-01.prm" --output run --quiet \
    --set "Seepage/top/Rain = $rain" >out.txt 2>&1 ||
    ! grep -qF "parameter 'Seepage/top/Rain'" out.txt || [ -e run ]; then
    echo "'$rain' is not refused by name, before anything is written:"
    cat out.txt
    exit 1
  fi
done
