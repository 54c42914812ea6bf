# Colours of messages: in a file or pipe, or against the wish of NO_COLOR, escape sequences
# would stand between the words; on a terminal a warning would not be seen.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B - "$program" "$root/tests/footing_coarse.prm" <<'PYTHON'
import os, pty, subprocess, sys
program, file = sys.argv[1:]
call = [program, "--dry-run", file, "--set"]
refused, warned = "Materials/soil/Cohesion = soft", "Mesh/Growth factor = 1.4"  # is not used
red, yellow = b"\x1b[1;31merror: \x1b[0m", b"\x1b[1;33mwarning: \x1b[0m"

def shown(setting, **variables):
    """What a terminal gets."""
    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "NO_COLOR": "", **variables}
    with subprocess.Popen([*call, setting], env=environment, stdout=theirs, stderr=theirs):
        os.close(theirs)
        text = b""
        try:
            while part := os.read(ours, 4096):
                text += part
        except OSError:  # its end
            pass
    os.close(ours)
    return text

assert red + b"parameter" in shown(refused), shown(refused)
assert yellow in shown(warned), shown(warned)
for variables in {"NO_COLOR": "1"}, {"TERM": "dumb"}:
    for setting, word in (refused, b"error: "), (warned, b"warning: "):
        text = shown(setting, **variables)
        assert word in text and b"\x1b" not in text, text
ended = subprocess.run([*call, refused], capture_output=True, env={**os.environ, "TERM": "xterm"})
assert ended.stderr.startswith(b"error: parameter"), ended
PYTHON
