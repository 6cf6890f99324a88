// Runs when all parts are defined.
unfoldTarget();
leadOrLoad();
