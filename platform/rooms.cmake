# platform: the board's senses and muscles. One header per service, one folder per backend.
