# The robot never moves while its mast is deployed.
cost 200 us;       # of one step of the controller
period 100 ms;     # of its looks at the posters

context mast {
  check stowed {
    fail: running(ndd.GoTo) && (running(mast.Deploy) || mast.state.height_m > 0);
    delay: ndd.GoTo for 30 s;
  }
  check standing {
    fail: request(mast.Deploy) && (rflex.odometry.v_m_s > 0.01 || rflex.odometry.v_m_s < -0.01);
  }
  check height {
    fail: request(mast.Deploy(height_m > 1.5));
  }
}
