"""A virtual environment for a test that needs other packages than the machine has."""

import os
import subprocess
import sys

SKIPPED = 77


def enter_environment(folder, packages, variable, what, seconds=240):
    """Restarts the script in an environment in `folder` that has the packages; exits with SKIPPED where `what` they are
    cannot be had within so many seconds. `variable`, set in the restarted one's environment, tells that this has been done."""
    python = os.path.join(folder, "bin", "python")
    if os.environ.get(variable):
        sys.exit("the packages are installed, but cannot be imported")
    try:
        if not os.path.exists(python):
            subprocess.run([sys.executable, "-m", "venv", folder], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages],
                       check=True, timeout=seconds)
    except (OSError, subprocess.SubprocessError) as error:
        print(f"skipped: {what} cannot be had: {error}")
        sys.exit(SKIPPED)
    os.execve(python, [python, *sys.argv], {**os.environ, variable: "1"})
