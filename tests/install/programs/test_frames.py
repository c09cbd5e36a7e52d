def test_it_takes_what_it_is_given(start):
    assert start(inputs=["z1.0", "z2.0"]).finish()["summary.frames"] == 2
