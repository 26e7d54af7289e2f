# The safety bag of laas.yaml: docs/laas-control.md describes the language.
cost 200 us;      # of one step of the controller
period 100 ms;    # of its looks at the posters

context motion {
  check located    { fail: request(ndd.GoTo) && !past(succeeded(pom.SetPos)); }
  check tracked    { fail: running(ndd.GoTo) && !running(rflex.TrackSpeedStart); }
  check seen       { fail: running(ndd.GoTo) && age(sick.echoes) > 500 ms; }
  check one_driver { exclusive: ndd.GoTo, rflex.GotoSpeed; interrupt: ndd.GoTo within 2 s; }
}

context picture {
  check standing {
    fail: request(sick.SegmentsOn) && (rflex.odometry.v_m_s > 0.01 || rflex.odometry.v_m_s < -0.01);
    delay: sick.SegmentsOn for 1 s;
  }
}
