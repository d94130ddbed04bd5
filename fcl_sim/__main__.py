"""`python -m fcl_sim`: the command line, where no script was installed."""

from fcl_sim.cli import main

if __name__ == "__main__":
    main()
